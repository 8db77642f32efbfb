within Modelica.Mechanics.Translational.Interfaces;
connector Flange "End of a rod"
  SI.Position s "Absolute position of the flange";
  flow SI.Force f "Force at the cut";
  annotation (Documentation(info="<html>
<p>Connected flanges move together; their forces sum to zero.</p></html>"));
end Flange;
