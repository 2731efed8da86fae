"""The 3-D view: stage, bodies, markers, labels, cameras and what moves them."""
