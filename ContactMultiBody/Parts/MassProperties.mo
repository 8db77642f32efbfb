within ContactMultiBody.Parts;
record MassProperties "Mass, centre of mass and inertia of a body, or that it is fixed"
  extends Modelica.Icons.Record;
  parameter Modelica.Units.SI.Mass m(min=0)=1 "Mass";
  parameter Modelica.Units.SI.Position r_CM[3]={0,0,0} "Centre of mass in the body's frame";
  parameter Modelica.Units.SI.Inertia I[3, 3]=diagonal({0.001,0.001,0.001})
    "Inertia tensor about the centre of mass, in the axes of the body's frame";
  parameter Boolean immovable=false "= true, if the body never moves; mass and inertia are without effect"
    annotation (Evaluate=true);
  annotation (Documentation(info="<html>
<p>
What a <a href=\"modelica://ContactMultiBody.CompiledContactManager\">CompiledContactManager</a> has to know of each body, for example
<code>MassProperties(m=ball.m, r_CM=ball.r_CM, I=ball.I)</code> for a body of the library and <code>MassProperties(immovable=true)</code>
for the ground.
</p>
</html>"));
end MassProperties;
