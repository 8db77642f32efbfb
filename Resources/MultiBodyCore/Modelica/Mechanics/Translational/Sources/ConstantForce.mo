within Modelica.Mechanics.Translational.Sources;
model ConstantForce "Constant force"
  extends Modelica.Mechanics.Translational.Interfaces.PartialForce;
  parameter SI.Force f_constant "Force on what is connected to the flange";
equation
  f = -f_constant;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A positive value accelerates the flange in the positive direction.</p></html>"));
end ConstantForce;
