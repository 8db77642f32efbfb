within ContactMultiBody;
model VolumeContactManager "Lets bodies collide that touch with faces, by forces proportional to the volume of their overlap"
  extends Interfaces.PartialContacts(
    final pointCapacity=4,
    final stiffnessChoice=Types.StiffnessChoice.Given,
    final exponent=1,
    stiffness=foundationModulus,
    final thickness=Internal.Engine.pairThicknesses(scene, m));

  parameter String geometry[n]=collider.geometry "Descriptor of each body's geometry, if not given by collider";
  parameter Real foundationModulus[m](each unit="N/m3")=fill(1e8, m) "Pressure by depth of each pair, E/h of a layer of thickness h"
    annotation (Dialog(group="Normal force"));
  parameter Modelica.Units.SI.Length exactWithin(min=Modelica.Constants.small)=Modelica.Constants.inf
    "Gap between bounding volumes up to which distances are exact; beyond it they are lower bounds, which cost less"
    annotation (Dialog(tab="Advanced"));
  final parameter Integer scene=Internal.Engine.intern(geometry, pair, 0) "Handle of the scene in the engine";
protected
  final parameter Boolean canTouch=Internal.canCollide(geometry, pair) "= true, if a pair has two geometries";
equation
  assert(canTouch,
    "Nothing can touch: no pair of the manager's bodies has two geometries. Give collider={body1.collider, ...}, or geometry and material, and shapes to the bodies.");
  (pairDistance,depth,weight,normal,point) = Internal.Engine.queryVolume(
    scene,
    {frame[i].r_0 for i in 1:n},
    {frame[i].R.T for i in 1:n},
    m,
    exactWithin);
  annotation (
    defaultComponentName="contacts",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-46,70},{46,-8}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-80,4},{80,-40}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-46,4},{46,-8}}, lineColor={255,0,0}, fillColor={255,128,128}, fillPattern=FillPattern.Solid),
        Text(extent={{-100,-60},{100,-90}}, textString="n=%n")}),
    Documentation(info="<html>
<p>
Connected like the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>, with the same effects, parameters and variables, but another law: bodies rest on an
elastic foundation of modulus k (pressure by depth, N/m<sup>3</sup>), whose pressures add up to
</p>
<blockquote><pre>
F = k V (1 + d/v0 dx/dt)
</pre></blockquote>
<p>
with the volume V of the overlap, acting at its centroid along the normal. Its energy is the integral of k/2 times the squared depth. A layer of thickness h and modulus E on a rigid base has k = E/h if it can spread sideways, and
E (1 - &nu;)/((1 + &nu;)(1 - 2&nu;))/h if it cannot (K. L. Johnson, Contact Mechanics, section 4.3).
</p>
<p>
<code>exactWithin</code> is that of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>: bounds instead of exact distances of bodies far apart, with the same forces and impacts.
</p>
<h4>What it is good for</h4>
<ul>
<li>Faces that carry unevenly: pressure grows linearly over a tilted face, as on rubber or a mat, which four points cannot show. The moment that straightens a tilted block is that of its whole face.</li>
<li>Contact areas that change: the force is proportional to the area of the face, whatever its shape; no stiffness has to be found for each.</li>
<li>On half-spaces the elastic force is exactly conservative.</li>
</ul>
<h4>Limits</h4>
<ul>
<li>Known are all pairs of shapes but open meshes, height fields among them, which have no volume: a contact with one ends the simulation with an error that says so.</li>
<li>A corner pushes with the third power of its depth: dropped on a corner a body goes deep before the floor stops it. Choose k so that this depth stays below the size of the bodies, or use the ContactManager.</li>
<li>Damping and friction act at four points about the centroid that have the second moment of the area: as those of the face as a whole where all of it moves alike, else nearly so.</li>
<li>Anchored friction takes <code>frictionStiffness</code> = 0.8 k by 1 m<sup>2</sup> unless it is given. For a face of area A, 0.8 k A suits better.</li>
<li>Between bounded shapes the normal is that of the shortest separating translation, and the energy is exact where one side of the overlap is flat.</li>
<li>An overlap costs some ten times as much as contact points; of round bodies with anything but half-spaces a fraction of a millisecond, of two capsules some milliseconds.</li>
</ul>
</html>"));
end VolumeContactManager;
