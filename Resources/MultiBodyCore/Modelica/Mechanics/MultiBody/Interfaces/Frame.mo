within Modelica.Mechanics.MultiBody.Interfaces;
connector Frame "Coordinate system fixed to a body, with the force and torque at a cut"
  SI.Position r_0[3] "Position of the origin, from the origin of the world frame, in coordinates of the world frame";
  Frames.Orientation R "Orientation with respect to the world frame";
  flow SI.Force f[3] "Force at the cut, in coordinates of this frame";
  flow SI.Torque t[3] "Torque at the cut, in coordinates of this frame";
  annotation (Documentation(info="<html>
<p>Connected frames coincide; their forces and torques sum to zero. Force and torque act on the component the connector
belongs to.</p></html>"));
end Frame;
