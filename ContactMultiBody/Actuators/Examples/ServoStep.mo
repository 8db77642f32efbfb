within ContactMultiBody.Actuators.Examples;
model ServoStep "A servo turns a flywheel to a new angle"
  extends Modelica.Icons.Example;
  Rotational.Servo servo(c=40, d=2) "PD controller" annotation (Placement(transformation(extent={{-20,-10},{0,10}})));
  Modelica.Mechanics.Rotational.Components.Inertia wheel(
    J=0.1,
    phi(start=0, fixed=true),
    w(start=0, fixed=true)) "Flywheel" annotation (Placement(transformation(extent={{20,-10},{40,10}})));
  Modelica.Blocks.Sources.Step step(height=0.5) "Wanted angle" annotation (Placement(transformation(extent={{-60,-10},{-40,10}})));
equation
  connect(step.y, servo.phi_ref) annotation (Line(points={{-39,0},{-22,0}}, color={0,0,127}));
  connect(servo.flange, wheel.flange_a) annotation (Line(points={{0,0},{20,0}}));
  annotation (
    experiment(StopTime=1, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
An oscillator with the angular frequency sqrt(c/J) = 20 rad/s and the damping ratio d/(2 sqrt(c J)) = 0.5: plot
<code>wheel.phi</code>, which overshoots by exp(-pi 0.5/sqrt(1 - 0.25)) = 16.3 %.
</p>
</html>"));
end ServoStep;
