within ContactMultiBody.Actuators.Examples;
model MotorWithCurrentLimit "A geared motor starts a flywheel at its current limit"
  extends Modelica.Icons.Example;
  Rotational.Motor motor(
    R=0.5,
    k=0.05,
    J=2e-5,
    ratio=20,
    d=1e-5,
    i_max=8,
    u_max=24) "Motor" annotation (Placement(transformation(extent={{-20,-10},{0,10}})));
  Modelica.Mechanics.Rotational.Components.Inertia wheel(
    J=0.2,
    phi(start=0, fixed=true),
    w(start=0, fixed=true)) "Flywheel" annotation (Placement(transformation(extent={{20,-10},{40,10}})));
  Modelica.Blocks.Sources.Constant voltage(k=24) "Voltage" annotation (Placement(transformation(extent={{-60,-10},{-40,10}})));
equation
  connect(voltage.y, motor.u) annotation (Line(points={{-39,0},{-22,0}}, color={0,0,127}));
  connect(motor.flange, wheel.flange_a) annotation (Line(points={{0,0},{20,0}}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The current stays at 8 A until the induced voltage is 20 V; then the motor approaches u k/(k<sup>2</sup> + R d) at its shaft. Plot
<code>motor.i</code> and <code>wheel.w</code>.
</p>
</html>"));
end MotorWithCurrentLimit;
