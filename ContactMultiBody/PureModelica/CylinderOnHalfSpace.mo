within ContactMultiBody.PureModelica;
model CylinderOnHalfSpace "Cylinder on a half-space"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=8);
  parameter Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius of the cylinder";
  parameter Modelica.Units.SI.Length length(min=Modelica.Constants.small) "Length along the third axis of frame[1], centred there";
  parameter Real outward[3](each unit="1")={0,0,1} "Outward unit normal of the half-space, in frame[2]; its plane goes through the origin";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.spheresOnHalfSpace(
    Geometry.cylinderRims(frame[1].r_0, frame[1].R.T, radius, length, transpose(frame[2].R.T)*outward),
    0,
    frame[2].r_0,
    transpose(frame[2].R.T)*outward,
    4);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,-20},{80,-70}}, lineColor={95,95,95}, fillColor={175,175,175}, fillPattern=FillPattern.Backward),
        Rectangle(extent={{-50,40},{50,-20}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder)}),
    Documentation(info="<html>
<p>Four points on each rim, the lowest one among them, each with a quarter of the stiffness, so that an end that stands flat has all of it; lying, two points carry half.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end CylinderOnHalfSpace;
