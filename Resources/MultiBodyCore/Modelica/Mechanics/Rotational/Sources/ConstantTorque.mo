within Modelica.Mechanics.Rotational.Sources;
model ConstantTorque "Constant torque"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialTorque;
  parameter SI.Torque tau_constant "Torque on what is connected to the flange";
  SI.AngularVelocity w "Angular velocity of the flange against the support";
  SI.Torque tau "Torque on what is connected to the flange";
equation
  w = der(phi);
  tau = tau_constant;
  flange.tau = -tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A positive value accelerates the flange in the positive direction.</p></html>"));
end ConstantTorque;
