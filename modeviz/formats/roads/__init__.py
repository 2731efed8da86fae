"""Measured road surfaces of other programs as the spectra of the two tracks that a vehicle runs in.

OpenCRG is read after its specification (ASAM OpenCRG 1.2, "Data file structure") by a reader of our
own: its libraries are in C and Matlab, and no wheel of them is maintained.
"""
