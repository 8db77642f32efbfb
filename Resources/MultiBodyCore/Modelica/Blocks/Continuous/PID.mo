within Modelica.Blocks.Continuous;
block PID "Proportional, integrating and differentiating controller"
  import Modelica.Blocks.Types.Init;
  extends Modelica.Blocks.Interfaces.SISO;
  parameter Real k=1 "Gain";
  parameter Modelica.Units.SI.Time Ti(min=Modelica.Constants.small, start=0.5) "Time constant of the integrator";
  parameter Modelica.Units.SI.Time Td(min=0, start=0.1) "Time constant of the derivative";
  parameter Real Nd(min=Modelica.Constants.small) = 10 "The derivative is filtered with Td/Nd";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.InitialState "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real xi_start=0 "Initial state of the integrator" annotation (Dialog(group="Initialization"));
  parameter Real xd_start=0 "Initial state of the derivative" annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  constant Modelica.Units.SI.Time unitTime=1 "For units";
  Modelica.Blocks.Math.Gain P(k=1) "Proportional part";
  Modelica.Blocks.Continuous.Integrator I(
    k=unitTime/Ti,
    y_start=xi_start,
    initType=if initType == Init.SteadyState then Init.SteadyState else if initType == Init.InitialState then Init.InitialState else Init.NoInit)
    "Integrating part";
  Modelica.Blocks.Continuous.Derivative D(
    k=Td/unitTime,
    T=max(Td/Nd, 100*Modelica.Constants.eps),
    x_start=xd_start,
    initType=if initType == Init.SteadyState or initType == Init.InitialOutput then Init.SteadyState else if initType == Init.InitialState then
        Init.InitialState else Init.NoInit) "Differentiating part";
  Modelica.Blocks.Math.Gain Gain(k=k) "Gain of the whole";
  Modelica.Blocks.Math.Add3 Add "Sum of the parts";
initial equation
  if initType == Init.InitialOutput then
    y = y_start;
  end if;
equation
  connect(u, P.u);
  connect(u, I.u);
  connect(u, D.u);
  connect(P.y, Add.u1);
  connect(I.y, Add.u2);
  connect(D.y, Add.u3);
  connect(Add.y, Gain.u);
  connect(Gain.y, y);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="PID")}),
    Documentation(info="<html>
<p>Transfer function <code>k*(1 + 1/(Ti*s) + Td*s/(Td/Nd*s + 1))</code>.</p></html>"));
end PID;
