within ContactMultiBody.PureModelica;
model BoxOnHalfSpace "Box on a half-space"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=8);
  parameter Modelica.Units.SI.Length size[3](each min=Modelica.Constants.small) "Full lengths of the box, centred in frame[1]";
  parameter Real outward[3](each unit="1")={0,0,1} "Outward unit normal of the half-space, in frame[2]; its plane goes through the origin";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.spheresOnHalfSpace(
    Geometry.boxCorners(frame[1].r_0, frame[1].R.T, size),
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
<p>Each corner is a contact point with a quarter of the stiffness, so that a face that lies flat has all of it.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end BoxOnHalfSpace;
