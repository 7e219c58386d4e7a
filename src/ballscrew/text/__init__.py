"""Text on the terminal: one module per question"""
