within ContactMultiBody.PureModelica;
model SphereOnCapsule "Sphere and capsule"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=1);
  parameter Modelica.Units.SI.Radius radius1(min=Modelica.Constants.small) "Radius of the sphere centred in frame[1]";
  parameter Modelica.Units.SI.Radius radius2(min=Modelica.Constants.small) "Radius of the capsule";
  parameter Modelica.Units.SI.Length length2(min=0) "Length of the capsule's segment along the third axis of frame[2], centred there";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.sphereOnSphere(
    frame[1].r_0,
    radius1,
    Geometry.closestOnSegment(frame[1].r_0, frame[2].r_0, frame[2].R.T[3, :], length2),
    radius2);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-40,80},{40,0}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,0},{80,-50}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.HorizontalCylinder, radius=25)}),
    Documentation(info="<html>
<p>One contact point, towards the point of the capsule's segment closest to the sphere.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end SphereOnCapsule;
