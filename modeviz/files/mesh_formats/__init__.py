"""Display meshes as other programs write them: binary glTF, STL, OBJ and PLY, one module each."""
