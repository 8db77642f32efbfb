within ContactMultiBody.Parts;
record Inertia "Mass, centre of mass and tensor of inertia of a body; immovable by default"
  extends Modelica.Icons.Record;
  parameter Modelica.Units.SI.Mass m(min=0)=0 "Mass; 0: immovable";
  parameter Modelica.Units.SI.Position r_CM[3]={0,0,0} "Centre of mass, in the frame that is connected to the manager";
  parameter Modelica.Units.SI.Inertia I[3, 3]=zeros(3, 3)
    "Tensor of inertia about the centre of mass, in the axes of that frame; 0: does not turn";
  annotation (Documentation(info="<html>
<p>
What contacts without events need to know about the bodies, from which they compute the effective mass where two bodies touch. The bodies of
<a href=\"modelica://ContactMultiBody.Parts\">Parts</a> bring theirs along.
</p>
</html>"));
end Inertia;
