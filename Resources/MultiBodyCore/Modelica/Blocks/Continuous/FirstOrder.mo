within Modelica.Blocks.Continuous;
block FirstOrder "Filter of first order"
  import Modelica.Blocks.Types.Init;
  parameter Real k=1 "Gain";
  parameter Modelica.Units.SI.Time T(start=1) "Time constant";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.NoInit "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  extends Modelica.Blocks.Interfaces.SISO(y(start=y_start));
initial equation
  if initType == Init.SteadyState then
    der(y) = 0;
  elseif initType == Init.InitialState or initType == Init.InitialOutput then
    y = y_start;
  end if;
equation
  T*der(y) + y = k*u;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="PT1")}),
    Documentation(info="<html>
<p>Transfer function <code>k/(T*s + 1)</code>.</p></html>"));
end FirstOrder;
