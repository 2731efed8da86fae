"""The panel of bodies on their mounts: purity of modes, axes and centres, targets."""
