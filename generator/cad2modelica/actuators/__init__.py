"""Actuators, sensors, inputs and outputs of the mechatronic model."""
