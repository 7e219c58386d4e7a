"""JSON documents: one module per question, a value in, a plain dictionary out"""
