within ContactMultiBody.Interfaces;
partial model PartialPairs "Bodies, the pairs of them that may touch, and how they move where they touch"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody.Frames;

  parameter Integer n(min=2)=2 "Number of bodies" annotation (Evaluate=true);
  parameter Parts.Collider collider[n] "Geometry, material and inertia of each body, usually {body1.collider, ...}";
  parameter Materials.Material material[n]=collider.material "Material of each body, if not given by collider";
  parameter Integer pairs[:, 2]=fill(0, 0, 2) "Pairs of bodies that may touch; empty: all pairs" annotation (Evaluate=true);
  final parameter Integer m=if size(pairs, 1) > 0 then size(pairs, 1) else div(n*(n - 1), 2) "Number of pairs"
    annotation (Evaluate=true);
  final parameter Integer pair[m, 2]=Internal.pairsLookedAt(pairs, n, m) "Bodies of each pair" annotation (Evaluate=true);
  parameter Integer pointCapacity(min=1)=4 "Largest number of contact points of a pair" annotation (Evaluate=true);

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame[n] "Frames of the bodies"
    annotation (Placement(transformation(extent={{-116,-80},{-84,80}})));

  SI.Length distance[m] "Signed distance of each pair, negative when penetrating; of bodies apart a lower bound beyond a finite exactWithin";
  Real relativeDepth(unit="1") "Largest penetration depth of all pairs by the thickness of the thinner body";
  SI.Velocity approachSpeed[m] "Speed at which the bodies of each pair approach where they touch";

protected
  SI.Length pairDistance[m] "Signed distance of each pair, given by the extending model";
  SI.Length depth[m, pointCapacity] "Penetration depth of each point, given by the extending model";
  Real weight[m, pointCapacity](each unit="1") "Share of the law's force each point carries, given by the extending model";
  Real normal[m, pointCapacity, 3](each unit="1") "Normal of each point, given by the extending model";
  SI.Position point[m, pointCapacity, 3] "Contact points, given by the extending model";
  SI.Position r_0[n, 3] "Origins of the bodies' frames, to be differentiated";
  SI.Velocity v_0[n, 3] "Velocities of the origins";
  SI.AngularVelocity w_0[n, 3] "Angular velocities, in world axes";
  SI.Velocity pointVelocity[m, pointCapacity, 3] "Velocity of first against second body at each point that touches";
  SI.Velocity pointSpeed[m, pointCapacity] "Approach speed at each point that touches";
  parameter SI.Length thickness[m]=fill(Modelica.Constants.inf, m) "Thickness of the thinner body of each pair";
equation
  for i in 1:n loop
    r_0[i, :] = frame[i].r_0;
    w_0[i, :] = Frames.resolve1(frame[i].R, frame[i].R.w);
  end for;
  v_0 = der(r_0);
  for i in 1:n loop
    assert(not collider[i].isFixed or max(abs(frame[i].r_0 - collider[i].r_0)) < 1e-6,
      "frame[" + String(i) + "] is not where collider[" + String(i) + "] says its Ground or Fixed is: give colliders in the order of the frames.");
  end for;

  distance = Internal.Unaliased.vector(pairDistance);
  relativeDepth = Internal.Kinematics.relativeDepth(distance, thickness);
  assert(noEvent(relativeDepth < 0.5),
    "The bodies of pair " + String(Internal.Kinematics.deepestPair(distance, thickness)) +
    " are deeper in each other than half the thickness of the thinner one and may come out on the other side: take a larger stiffness, or a smaller mass or speed.",
    AssertionLevel.warning);
  pointVelocity = Internal.Kinematics.pointVelocities(depth, point, {frame[i].r_0 for i in 1:n}, v_0, w_0, pair);
  pointSpeed = Internal.Kinematics.approachSpeeds(depth, pointVelocity, normal);
  approachSpeed = Internal.Kinematics.pairApproachSpeeds(weight, normal, point, {frame[i].r_0 for i in 1:n}, v_0, w_0, pair);
  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>
An extending model gives <code>pairDistance</code>, <code>depth</code>, <code>weight</code>, <code>normal</code> and <code>point</code> as functions of the poses of
<code>frame</code>, by one call with these as results, and uses them for nothing else than arguments of functions: see
<a href=\"modelica://ContactMultiBody.Internal.Unaliased\">Unaliased</a> for the reason.
</p>
</html>"));
end PartialPairs;
