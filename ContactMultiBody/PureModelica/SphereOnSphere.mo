within ContactMultiBody.PureModelica;
model SphereOnSphere "Two spheres"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=1);
  parameter Modelica.Units.SI.Radius radius1(min=Modelica.Constants.small) "Radius of the sphere centred in frame[1]";
  parameter Modelica.Units.SI.Radius radius2(min=Modelica.Constants.small) "Radius of the sphere centred in frame[2]";
equation
  (pairDistance,depth,weight,normal,point) = Geometry.sphereOnSphere(frame[1].r_0, radius1, frame[2].r_0, radius2);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-80,40},{0,-40}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{0,40},{80,-40}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere)}),
    Documentation(info="<html>
<p>One contact point on the line between the centres.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end SphereOnSphere;
