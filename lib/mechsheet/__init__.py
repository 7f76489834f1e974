"""Reactive calculation documents for the design of mechanisms."""
