within Modelica.Mechanics.Rotational.Interfaces;
connector Flange "End of a shaft"
  SI.Angle phi "Absolute angle of the flange";
  flow SI.Torque tau "Torque at the cut";
  annotation (Documentation(info="<html>
<p>Connected flanges turn together; their torques sum to zero.</p></html>"));
end Flange;
