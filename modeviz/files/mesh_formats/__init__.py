"""Display meshes as other programs write them: binary glTF, STL, OBJ, PLY, COLLADA and STEP."""
