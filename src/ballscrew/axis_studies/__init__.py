"""Questions about an axis in motion: its duty, and how it warms up; a case in, a frozen value out"""
