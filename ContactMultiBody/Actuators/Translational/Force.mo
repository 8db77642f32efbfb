within ContactMultiBody.Actuators.Translational;
model Force "Force after a signal, limited"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.Force f_max(min=0)=Modelica.Constants.inf "Largest force";
  Modelica.Blocks.Interfaces.RealInput f_ref(final quantity="Force", final unit="N") "Wanted force"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
equation
  f = Internal.limited(f_ref, f_max);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,-40},{40,-40}}, color={0,0,127}, thickness=1, arrow={Arrow.None,Arrow.Filled})}),
    Documentation(info="<html>
<p>
The signal acts on the flange as force, and on the housing against it; beyond &plusmn;<code>f_max</code> it is cut off.
</p>
</html>"));
end Force;
