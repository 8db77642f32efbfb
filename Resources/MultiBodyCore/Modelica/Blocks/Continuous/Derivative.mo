within Modelica.Blocks.Continuous;
block Derivative "Filtered derivative of the input"
  import Modelica.Blocks.Types.Init;
  parameter Real k=1 "Factor";
  parameter Modelica.Units.SI.Time T(min=Modelica.Constants.small) = 0.01 "Time constant of the filter";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.NoInit "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real x_start=0 "Initial state" annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  extends Modelica.Blocks.Interfaces.SISO;
  output Real x(start=x_start) "State: the filtered input";
protected
  parameter Boolean zeroGain=abs(k) < Modelica.Constants.eps "= true, if the output is zero";
initial equation
  if initType == Init.SteadyState then
    der(x) = 0;
  elseif initType == Init.InitialState then
    x = x_start;
  elseif initType == Init.InitialOutput then
    if zeroGain then
      x = u;
    else
      y = y_start;
    end if;
  end if;
equation
  der(x) = if zeroGain then 0 else (u - x)/T;
  y = if zeroGain then 0 else k*(u - x)/T;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="D")}),
    Documentation(info="<html>
<p>Transfer function <code>k*s/(T*s + 1)</code>.</p></html>"));
end Derivative;
