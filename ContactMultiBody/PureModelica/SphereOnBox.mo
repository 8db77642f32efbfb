within ContactMultiBody.PureModelica;
model SphereOnBox "Sphere and box"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=1);
  parameter Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius of the sphere centred in frame[1]";
  parameter Modelica.Units.SI.Length size[3](each min=Modelica.Constants.small) "Full lengths of the box, centred in frame[2]";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.sphereOnBox(
    frame[2].R.T*(frame[1].r_0 - frame[2].r_0),
    radius,
    size,
    frame[2].r_0,
    frame[2].R.T);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-40,60},{40,-20}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-50,-20},{50,-80}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.HorizontalCylinder)}),
    Documentation(info="<html>
<p>One contact point on a face, an edge or a corner of the box.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end SphereOnBox;
