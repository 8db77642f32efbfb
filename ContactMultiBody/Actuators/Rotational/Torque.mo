within ContactMultiBody.Actuators.Rotational;
model Torque "Torque after a signal, limited"
  extends Interfaces.PartialRotationalDrive;
  parameter Modelica.Units.SI.Torque tau_max(min=0)=Modelica.Constants.inf "Largest torque";
  Modelica.Blocks.Interfaces.RealInput tau_ref(final quantity="Torque", final unit="N.m") "Wanted torque"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
equation
  tau = Internal.limited(tau_ref, tau_max);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,-40},{40,-40}}, color={0,0,127}, thickness=1, arrow={Arrow.None,Arrow.Filled})}),
    Documentation(info="<html>
<p>
The signal acts on the flange as torque, and on the housing against it; beyond &plusmn;<code>tau_max</code> it is cut off.
</p>
</html>"));
end Torque;
