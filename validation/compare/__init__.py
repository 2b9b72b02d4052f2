"""The comparison of a case's variants with their references, and what it leaves."""
