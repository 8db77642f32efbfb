"""Missions: a machine, a course around it, a goal, a scripted operator, and a score from contact data."""
