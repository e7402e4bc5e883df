"""Base of all modules: arguments, arrays, documents, text, units; it knows no bearing."""
