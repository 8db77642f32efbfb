within Modelica.Blocks.Sources;
block Cosine "Cosine wave"
  import Modelica.Constants.pi;
  parameter Real amplitude=1 "Amplitude";
  parameter Modelica.Units.SI.Frequency f(start=1) "Frequency";
  parameter Modelica.Units.SI.Angle phase=0 "Phase at startTime";
  parameter Boolean continuous=false "= true, if the output is constant, not offset, before startTime, so that it does not jump";
  extends Modelica.Blocks.Interfaces.SignalSource;
equation
  y = offset + amplitude*(if continuous then cos(2*pi*f*max(time - startTime, 0) + phase) else if time < startTime then 0 else cos(2*pi*f*(
    time - startTime) + phase));
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,0},{-50,50},{-20,0},{10,-50},{40,0},{70,50}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is <code>offset + amplitude*cos(2*pi*f*(time - startTime) + phase)</code> from <code>startTime</code> on.</p></html>"));
end Cosine;
