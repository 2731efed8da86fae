"""Every command that a session takes, to one of the small cabin, as a value."""

from dataclasses import replace

from mounted_cabin import mounted_cabin

from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement
from modeviz.viewer.session.commands import absorbers, decisions, looks
from modeviz.viewer.session.state import ResponseCurve

VEHICLE = mounted_cabin()
RATES = MountRates(1e5, 2e5, 3e5)
FORE_AFT = ResponseCurve(0, "fore-aft")

DECISIONS = [
    decisions.SetRate("B", "lateral", 1e5),
    decisions.SetLossFactor("B", 0.3),
    decisions.PlaceMounts("B", "angles", (None, None, 0.1)),
    decisions.DragMounts("B", Placement((0.1, 0, 0)), 0),
    decisions.TakeRates({"A": RATES}),
    decisions.TakeDesign({"A": RATES}, {"B": Placement((0, 0.1, 0))}),
    decisions.LinkRates("A", True),
    decisions.ToggleLock("A", "lateral"),
    decisions.Pin("Mine"),
    decisions.AddVariant("Mine", {"A": RATES}),
    decisions.Load("Soft"),
    decisions.ChangeTargets({"gap": 3.0}),
    decisions.ChangePlan(lambda _, plan: replace(plan, n_starts=3)),
]

LOOKS = [
    looks.ShowMode("cab roll"),
    looks.ChangeMotion(
        kind="component", component="cab", component_mode=5, operating_hz=12.0, load_case="braking 1 g"
    ),
    looks.ChangeCharts(
        load="front left radial force",
        decibels=False,
        log_frequency=True,
        cursor_hz=9.3,
        path_curve=FORE_AFT,
        paths_by="body",
        in_vehicle_axes=True,
    ),
    looks.ChangeLook(coloring="displacement", see_through=False, follow=True),
    looks.LookAtRigid(body="cab", axes="crank", crank="z", support="mounted", drawn=True),
    looks.LookAtEngine(curve=FORE_AFT, speed_hz=12.0),
    looks.ShowGhost("none"),
    looks.ShowComparedGhost(True),
    looks.ShowBody("cab", False),
    looks.ChooseCurve(1, FORE_AFT),
    looks.Overlay("Soft", True),
    looks.CompareWith("Soft"),
    looks.Drive(road="rough", speed=25.0),
    looks.SelectGroup("B"),
    looks.ChooseUnit("stiffness", "lbf/in"),
    looks.ShowClassicError(True),
]

ON_THE_WAY = [
    decisions.ResetRate("A", "lateral"),
    decisions.ResetGroups(("A",)),
    decisions.Rename("Mine", "Ours"),
    decisions.Swap(),
    decisions.ResetPlacement("B"),
    decisions.Forget("Ours"),
]
"""Those that change something only after others."""

ABSORBERS = [
    absorbers.AddAbsorber(Absorber("roof", "cab", (1.2, 0.0, 1.6), 10.0, 9.0, 0.1)),
    absorbers.WeighAbsorber("roof", 12.0),
    absorbers.RemoveAbsorber("roof"),
]
"""Those that give the vehicle other parts."""
