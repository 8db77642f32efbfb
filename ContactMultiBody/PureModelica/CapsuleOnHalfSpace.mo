within ContactMultiBody.PureModelica;
model CapsuleOnHalfSpace "Capsule on a half-space"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=2);
  parameter Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius of the capsule";
  parameter Modelica.Units.SI.Length length(min=0) "Length of the segment along the third axis of frame[1], centred there";
  parameter Real outward[3](each unit="1")={0,0,1} "Outward unit normal of the half-space, in frame[2]; its plane goes through the origin";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.spheresOnHalfSpace(
    {frame[1].r_0 - length/2*frame[1].R.T[3, :],frame[1].r_0 + length/2*frame[1].R.T[3, :]},
    radius,
    frame[2].r_0,
    transpose(frame[2].R.T)*outward);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,-20},{80,-70}}, lineColor={95,95,95}, fillColor={175,175,175}, fillPattern=FillPattern.Backward),
        Rectangle(extent={{-60,30},{60,-20}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder, radius=25)}),
    Documentation(info="<html>
<p>One contact point below each round end, each with half of the stiffness.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end CapsuleOnHalfSpace;
