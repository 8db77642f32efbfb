within Modelica.Blocks.Continuous;
block SecondOrder "Filter of second order"
  import Modelica.Blocks.Types.Init;
  parameter Real k=1 "Gain";
  parameter Real w(start=1) "Angular frequency";
  parameter Real D(start=1) "Damping, 1 for the aperiodic limit";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.NoInit "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  parameter Real yd_start=0 "Initial derivative of the output" annotation (Dialog(group="Initialization"));
  extends Modelica.Blocks.Interfaces.SISO(y(start=y_start));
  output Real yd(start=yd_start) "Derivative of the output";
initial equation
  if initType == Init.SteadyState then
    der(y) = 0;
    der(yd) = 0;
  elseif initType == Init.InitialState or initType == Init.InitialOutput then
    y = y_start;
    yd = yd_start;
  end if;
equation
  der(y) = yd;
  der(yd) = w*(w*(k*u - y) - 2*D*yd);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="PT2")}),
    Documentation(info="<html>
<p>Transfer function <code>k/((s/w)^2 + 2*D*s/w + 1)</code>.</p></html>"));
end SecondOrder;
