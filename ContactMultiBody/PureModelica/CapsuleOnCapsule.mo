within ContactMultiBody.PureModelica;
model CapsuleOnCapsule "Two capsules"
  extends Interfaces.PartialContacts(
    final n=2,
    final pairs={{1,2}},
    final pointCapacity=1);
  parameter Modelica.Units.SI.Radius radius1(min=Modelica.Constants.small) "Radius of the first capsule";
  parameter Modelica.Units.SI.Length length1(min=0) "Length of its segment along the third axis of frame[1], centred there";
  parameter Modelica.Units.SI.Radius radius2(min=Modelica.Constants.small) "Radius of the second capsule";
  parameter Modelica.Units.SI.Length length2(min=0) "Length of its segment along the third axis of frame[2], centred there";
protected
  Modelica.Units.SI.Position p[3] "Point of the first segment closest to the second";
  Modelica.Units.SI.Position q[3] "Point of the second segment closest to the first";
equation
  (p,q) = Geometry.closestOfSegments(frame[1].r_0, frame[1].R.T[3, :], length1, frame[2].r_0, frame[2].R.T[3, :], length2);
  (pairDistance,depth,weight,normal,point) = Geometry.sphereOnSphere(p, radius1, q, radius2);
  annotation (
    defaultComponentName="contact",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-60,50},{60,0}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder, radius=25),
        Rectangle(extent={{-80,0},{80,-50}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.HorizontalCylinder, radius=25)}),
    Documentation(info="<html>
<p>One contact point between the closest points of the segments. Capsules that lie along each other touch along a length, of
which one point carries all the force; they are better left to the contact engine, whose contact has an energy of both
lengths: as hard where capsules lie along each other, softer by 24/35 where they cross, by half where an end touches.</p>
<p>The laws and their parameters are those of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.</p>
</html>"));
end CapsuleOnCapsule;
