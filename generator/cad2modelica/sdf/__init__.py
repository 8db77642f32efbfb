"""SDFormat, the description format of Gazebo, to the mechanism."""
