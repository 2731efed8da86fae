"""Tables of mounts from other programs, each file as `Bushing`s: what springs and dampers join.

Excel's .xlsx is read by openpyxl 3.1 (MIT, one small dependency, maintained, reads row by row and gives
the values that Excel stored for formulas); pandas would bring 100 MB for the same reader, calamine a
compiled one. Property files of bushings are read by a parser of their own: no package reads them.
"""
