"""The tab in which mount rates are optimised."""
