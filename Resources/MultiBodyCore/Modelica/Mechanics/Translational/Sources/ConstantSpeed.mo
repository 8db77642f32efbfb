within Modelica.Mechanics.Translational.Sources;
model ConstantSpeed "Motion at a constant velocity"
  extends Modelica.Mechanics.Translational.Interfaces.PartialForce;
  parameter SI.Velocity v_fixed "Wanted velocity";
  SI.Velocity v "Velocity of the flange against the support";
equation
  v = der(s);
  v = v_fixed;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>Moves the flange, whatever force it takes.</p></html>"));
end ConstantSpeed;
