"""Formulas recorded as steps on a tape, merged, differentiated, interpreted by NumPy; independent of ball screws."""
