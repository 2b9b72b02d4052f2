"""Runs that leave something: resumable ones with their files, and many cases side by side."""
