"""What all output needs: text of JSON, wrapped lines, the bibliography"""
