"""What `peers.py` measures: one module a program, and how they are measured alike."""
