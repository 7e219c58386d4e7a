"""Torque cards: measured torques of one nut with all that they need, checked, and as a log"""
