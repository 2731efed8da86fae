"""STEP files of boxes, written by ISO 10303-21 and AP203: faceted solids in a unit of one's choice."""

from collections.abc import Sequence

import numpy as np

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
LOOPS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""The corners of each face, seen from outside against the clock."""

UNITS = {
    "mm": "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))",
    "m": "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))",
}


class StepFile:
    """The lines of a file, each numbered as it is added."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, text: str) -> str:
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return f"#{len(self.lines)}"

    def content(self) -> bytes:
        head = "FILE_DESCRIPTION((''),'2;1');FILE_NAME('','2026-01-01',(''),(''),'','','');"
        schema = "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));"
        data = "\n".join(self.lines)
        text = (
            f"ISO-10303-21;\nHEADER;{head}{schema}ENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n"
        )
        return text.encode()


def box_step(low: Sequence[float], high: Sequence[float], unit: str = "mm") -> bytes:
    """One box between two corners, in that unit."""
    file = StepFile()
    points = [
        file.add(f"CARTESIAN_POINT('',({x!r},{y!r},{z!r}))")
        for x, y, z in (np.array(low) + CORNERS * (np.array(high) - low)).astype(float).tolist()
    ]
    faces = [_face(file, points, loop) for loop in LOOPS]
    shell = file.add(f"CLOSED_SHELL('',({','.join(faces)}))")
    solid = file.add(f"FACETED_BREP('box',{shell})")
    length = file.add(UNITS[unit])
    angle = file.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
    solid_angle = file.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
    accuracy = file.add(
        f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),{length},'distance_accuracy_value','')"
    )
    context = file.add(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
        f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({accuracy}))"
        f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))REPRESENTATION_CONTEXT('',''))"
    )
    shape = file.add(f"FACETED_BREP_SHAPE_REPRESENTATION('',({solid}),{context})")
    application = file.add("APPLICATION_CONTEXT('configuration controlled 3D designs')")
    file.add(f"APPLICATION_PROTOCOL_DEFINITION('','config_control_design',1994,{application})")
    product_context = file.add(f"MECHANICAL_CONTEXT('',{application},'mechanical')")
    product = file.add(f"PRODUCT('box','box','',({product_context}))")
    formation = file.add(
        f"PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE('','',{product},.NOT_KNOWN.)"
    )
    design = file.add(f"DESIGN_CONTEXT('',{application},'design')")
    definition = file.add(f"PRODUCT_DEFINITION('','',{formation},{design})")
    defined = file.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
    file.add(f"SHAPE_DEFINITION_REPRESENTATION({defined},{shape})")
    return file.content()


def _face(file: StepFile, points: Sequence[str], loop: Sequence[int]) -> str:
    """A flat face with its plane."""
    first, second, third = (CORNERS[i].astype(float) for i in loop[:3])
    along = second - first
    normal = np.cross(along, third - second)
    directions = [
        file.add(f"DIRECTION('',({x!r},{y!r},{z!r}))") for x, y, z in np.stack([normal, along]).tolist()
    ]
    axes = file.add(f"AXIS2_PLACEMENT_3D('',{points[loop[0]]},{directions[0]},{directions[1]})")
    plane = file.add(f"PLANE('',{axes})")
    corners = file.add(f"POLY_LOOP('',({','.join(points[i] for i in loop)}))")
    bound = file.add(f"FACE_OUTER_BOUND('',{corners},.T.)")
    return file.add(f"FACE_SURFACE('',({bound}),{plane},.T.)")
