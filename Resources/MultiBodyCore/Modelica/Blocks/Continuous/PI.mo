within Modelica.Blocks.Continuous;
block PI "Proportional and integrating controller"
  import Modelica.Blocks.Types.Init;
  parameter Real k=1 "Gain";
  parameter Modelica.Units.SI.Time T(start=1, min=Modelica.Constants.small) "Time constant";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.NoInit "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real x_start=0 "Initial state" annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  extends Modelica.Blocks.Interfaces.SISO;
  output Real x(start=x_start) "State: integral of u/T";
initial equation
  if initType == Init.SteadyState then
    der(x) = 0;
  elseif initType == Init.InitialState then
    x = x_start;
  elseif initType == Init.InitialOutput then
    y = y_start;
  end if;
equation
  der(x) = u/T;
  y = k*(x + u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="PI")}),
    Documentation(info="<html>
<p>Transfer function <code>k*(1 + 1/(T*s))</code>.</p></html>"));
end PI;
