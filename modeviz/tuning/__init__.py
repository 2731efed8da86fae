"""Changing mount rates and looking for better ones."""
