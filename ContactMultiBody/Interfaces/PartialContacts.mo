within ContactMultiBody.Interfaces;
partial model PartialContacts "Forces between bodies from depths, normals and points that an extending model provides"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody.Frames;
  extends PartialTurningFriction;

  SI.Force force[m, 3] "Force on the first body of each pair, in world axes";

protected
  SI.Force bodyForce[n, 3] "Contact force on each body, in world axes";
  SI.Torque bodyTorque[n, 3] "Contact torque on each body about its frame, in world axes";
equation
  force = Internal.Resultants.pairForces(pointForce);
  bodyForce = Internal.Resultants.bodyForces(pointForce, pair, n);
  if useTurningFriction then
    bodyTorque = Internal.Resultants.bodyTorques(depth, pointForce, point, {frame[i].r_0 for i in 1:n}, pair) + turningTorque;
  else
    bodyTorque = Internal.Resultants.bodyTorques(depth, pointForce, point, {frame[i].r_0 for i in 1:n}, pair);
  end if;
  for i in 1:n loop
    frame[i].f = -Frames.resolve2(frame[i].R, bodyForce[i, :]);
    frame[i].t = -Frames.resolve2(frame[i].R, bodyTorque[i, :]);
  end for;
  annotation (Documentation(info="<html>
<p>
All of a contact but its geometry. For a geometry of your own extend this class and give the protected variables of
<a href=\"modelica://ContactMultiBody.Interfaces.PartialPairs\">PartialPairs</a> as functions of the poses:
</p>
<blockquote><pre>
model MyContact
  extends ContactMultiBody.Interfaces.PartialContacts(final n=2, final pairs={{1,2}}, final pointCapacity=1);
equation
  (pairDistance,depth,weight,normal,point) = myGeometry(frame[1].r_0, frame[1].R.T, frame[2].r_0, frame[2].R.T);
end MyContact;
</pre></blockquote>
<p>
<code>normal</code> is the unit normal from the second body to the first, <code>depth</code> positive when penetrating, <code>weight</code> the share of the law's force that a point carries;
the first point is that nearest also while the bodies are apart. See <a href=\"modelica://ContactMultiBody.PureModelica\">PureModelica</a> for examples.
</p>
</html>"));
end PartialContacts;
