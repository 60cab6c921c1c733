"""What a course asks for, from ``course.yaml``."""

from icsolve.grade.course.reading import read_course
from icsolve.grade.course.values import ATTEMPTS, DECIMALS, Course, Credit, Policy

__all__ = ["ATTEMPTS", "DECIMALS", "Course", "Credit", "Policy", "read_course"]
