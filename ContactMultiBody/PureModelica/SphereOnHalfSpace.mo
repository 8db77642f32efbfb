within ContactMultiBody.PureModelica;
model SphereOnHalfSpace "Sphere on a half-space"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=1);
  parameter Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius of the sphere, centred in frame[1]";
  parameter Real outward[3](each unit="1")={0,0,1} "Outward unit normal of the half-space, in frame[2]; its plane goes through the origin";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.spheresOnHalfSpace({frame[1].r_0}, radius, frame[2].r_0, transpose(frame[2].R.T)*outward);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,-20},{80,-70}}, lineColor={95,95,95}, fillColor={175,175,175}, fillPattern=FillPattern.Backward),
        Ellipse(extent={{-40,60},{40,-20}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.Sphere)}),
    Documentation(info="<html>
<p>One contact point below the centre.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end SphereOnHalfSpace;
