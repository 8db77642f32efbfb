within ContactMultiBody.Actuators.Examples;
model SpindleAxis "A spindle drive moves a slide up to its end stop"
  extends Modelica.Icons.Example;
  Translational.CascadeServo drive(
    pitch=0.01,
    J_design=4e-5) "Motor with spindle and controller" annotation (Placement(transformation(extent={{-20,-10},{0,10}})));
  Translational.EndStop stop(
    s_max=0.2,
    c=1e6,
    damping=5) "End of the range" annotation (Placement(transformation(extent={{-20,30},{0,50}})));
  Modelica.Mechanics.Translational.Components.Mass slide(
    m=5,
    s(start=0, fixed=true),
    v(start=0, fixed=true)) "Slide" annotation (Placement(transformation(extent={{20,-10},{40,10}})));
  Modelica.Blocks.Sources.Ramp ramp(height=0.25, duration=1) "Wanted position" annotation (Placement(transformation(extent={{-60,-10},{-40,10}})));
equation
  connect(ramp.y, drive.s_ref) annotation (Line(points={{-39,0},{-22,0}}, color={0,0,127}));
  connect(drive.flange, slide.flange_a) annotation (Line(points={{0,0},{20,0}}, color={0,127,0}));
  connect(stop.flange, slide.flange_a) annotation (Line(points={{0,40},{10,40},{10,0},{20,0}}, color={0,127,0}));
  annotation (
    experiment(StopTime=2, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The drive pushes the slide against the stop at 0.2 m until the motor is at its current limit: the stop is pressed in by
2 pi k i_max/(pitch c) = 0.628 mm. Plot <code>slide.s</code> and <code>drive.i</code>.
</p>
</html>"));
end SpindleAxis;
