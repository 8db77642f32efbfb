within Modelica.Mechanics.Translational.Sources;
model Force "Force from a signal"
  extends Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2;
  Modelica.Blocks.Interfaces.RealInput f(unit="N") "Force on what is connected to the flange"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
equation
  flange.f = -f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A positive signal accelerates the flange in the positive direction.</p></html>"));
end Force;
