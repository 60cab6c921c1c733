"""Statics in space: bodies on balls, bearings, hinges, welds and gears, each in equilibrium.

Only a case whose points have three coordinates comes here; nothing of it is imported otherwise.
"""
