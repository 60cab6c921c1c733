"""Reading of what students write: a number, a unit, a direction, or a flag."""
