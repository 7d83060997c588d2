"""Tables and pictures of the cases, made from their runs: `python -m figures stenosis`, in the folder `cases`.

A module a case has `figures(case)`, which draws `result.png` and gives the text of each block of the README. What is found comes out of the
files of the run, what is expected out of formulas with their source, or out of data that `VASO_DATA` names.
"""
