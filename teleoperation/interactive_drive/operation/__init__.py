"""Keys and gamepad axes that set inputs."""
