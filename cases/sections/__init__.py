"""The sections of a case file, a module each, and the case that they make up; values are in SI."""
