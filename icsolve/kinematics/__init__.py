"""Twists of the links, instant centres by Aronhold and Kennedy, rates, and what moves to second order."""
