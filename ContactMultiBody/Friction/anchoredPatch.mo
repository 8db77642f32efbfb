within ContactMultiBody.Friction;
pure function anchoredPatch "Friction of the contact points of two bodies, held by springs between anchors and points"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:] "Normal force of each point";
  input Real normal[size(normalForce, 1), 3](each unit="1") "Unit normals";
  input Modelica.Units.SI.Position point[size(normalForce, 1), 3] "Contact points";
  input Modelica.Units.SI.Velocity velocity[size(normalForce, 1), 3] "Velocities of the first body against the second";
  input Modelica.Units.SI.Position anchor[6] "Stretch of the patch: translation (1:3), turning times radius of gyration (4:6)";
  input Modelica.Units.SI.AngularVelocity w[3] "Mean angular velocity of the two bodies";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness(min=Modelica.Constants.small)
    "Stiffness of the static springs of all points together";
  input Real muStatic(min=0, unit="1") "Coefficient of static friction";
  input Real muDynamic(min=0, unit="1") "Coefficient of sliding friction";
  input Modelica.Units.SI.Velocity limitSpeed(min=Modelica.Constants.small) "Speed that separates sticking from sliding";
  input Modelica.Units.SI.Time dampingTime(min=0) "Damping of the static springs by their stiffness";
  input Modelica.Units.SI.Time relaxationTime(min=Modelica.Constants.small) "Time in which an anchor that holds nothing is forgotten";
  output Modelica.Units.SI.Force force[size(normalForce, 1), 3] "Friction forces on the first body, tangential";
  output Modelica.Units.SI.Velocity anchorRate[6] "Derivative of the stretch of the patch";
protected
  constant Real elastic(unit="1")=0.9 "Share of the limit up to which the anchors do not move";
  constant Real slipping(unit="1")=0.95 "Share of the limit from which on they are dragged along as the patch slides";
  constant Real carrying(unit="1")=0.05 "Share of the friction from which on a point counts fully as one that may slip";
  constant Modelica.Units.SI.Length shortest=1e-8 "Way in which a point without normal force loses its anchor";
  constant Modelica.Units.SI.Radius smallest=1e-6 "Radius of gyration below which a patch does not hold turning";
  constant Modelica.Units.SI.Velocity rest=1e-12 "Speed of a patch that has no direction";
  Modelica.Units.SI.Velocity sliding[size(normalForce, 1), 3] "Tangential velocities";
  Modelica.Units.SI.Force capacity[size(normalForce, 1)] "Largest friction force of each point";
  Modelica.Units.SI.Length limit "Stretch at which the spring of a point carries all the friction there is";
  Real share[size(normalForce, 1)](each unit="1") "Share of the stiffness at each point";
  Real part[size(normalForce, 1)](each unit="1") "The same, of all that is held; the first point's where nothing is";
  Real meanNormal[3](each unit="1") "Mean normal";
  Modelica.Units.SI.Position centre[3] "Centre of the friction";
  Modelica.Units.SI.Radius radius "Radius of gyration of the patch";
  Modelica.Units.SI.Position lever[size(normalForce, 1), 3] "Levers of the points about the centre";
  Real arm[size(normalForce, 1), 3](each unit="1") "Levers by the radius of gyration";
  Real radius2(unit="m2") "Square of the radius of gyration";
  Real speed2(unit="m2/s2") "Mean square of the sliding speeds";
  Modelica.Units.SI.Velocity speed "Root mean square of the sliding speeds";
  Modelica.Units.SI.Position stretch[size(normalForce, 1), 3] "Stretch at each point";
  Modelica.Units.SI.Length pointStretch "Length of the stretch at a point";
  Modelica.Units.SI.Length largest "Largest stretch of the points that carry";
  Real meanStretch2(unit="m2") "Mean square of the stretches";
  Modelica.Units.SI.Length margin "Stretch that is left before the first point slips";
  Real coupling(unit="1") "Share of the springs that acts; less than one where they are stretched too far";
  Real damper(unit="1") "Share of the damper that acts";
  Real sliding01(unit="1") "0: the patch sticks, 1: it slides";
  Modelica.Units.SI.Velocity motion[6] "Velocity of the patch";
algorithm
  for k in 1:size(normalForce, 1) loop
    sliding[k, :] := velocity[k, :] - (velocity[k, :]*normal[k, :])*normal[k, :];
    capacity[k] := max(normalForce[k], 0)*stribeck(sqrt(sliding[k, :]*sliding[k, :] + rest^2), muStatic, muDynamic, limitSpeed);
  end for;
  limit := sum(capacity)/stiffness + shortest;
  share := capacity/(stiffness*limit);
  part := capacity/(sum(capacity) + Modelica.Constants.small);
  part[1] := part[1] + max(1 - sum(part), 0);

  meanNormal := normal[1, :];
  centre := point[1, :];
  for k in 2:size(normalForce, 1) loop
    meanNormal := meanNormal + part[k]*(normal[k, :] - normal[1, :]);
    centre := centre + part[k]*(point[k, :] - point[1, :]);
  end for;
  radius2 := smallest^2;
  speed2 := rest^2;
  for k in 1:size(normalForce, 1) loop
    lever[k, :] := point[k, :] - centre;
    radius2 := radius2 + share[k]*(lever[k, :]*lever[k, :]);
    speed2 := speed2 + part[k]*(sliding[k, :]*sliding[k, :]);
  end for;
  radius := sqrt(radius2);
  speed := sqrt(speed2);
  arm := lever/radius;

  stretch := Internal.pointStretches(anchor, arm, normal);
  largest := 0;
  meanStretch2 := Modelica.Constants.small;
  for k in 1:size(normalForce, 1) loop
    pointStretch := sqrt(stretch[k, :]*stretch[k, :] + Modelica.Constants.small);
    largest := max(largest, min(1, part[k]/carrying)*pointStretch);
    meanStretch2 := meanStretch2 + part[k]*pointStretch^2;
  end for;
  margin := max(limit - largest, 0);
  coupling := min(1, limit/sqrt(meanStretch2));
  damper := margin/max(max(margin, dampingTime*speed), Modelica.Constants.small);
  force := zeros(size(normalForce, 1), 3);
  for k in 1:size(normalForce, 1) loop
    force[k, :] := -stiffness*share[k]*(coupling*stretch[k, :] + damper*dampingTime*sliding[k, :]);
  end for;

  sliding01 := min(max((largest - elastic*limit)/((slipping - elastic)*limit), 0), 1);
  motion := Internal.patchSum(share, arm, sliding);
  anchorRate := coupling*(motion - sliding01*Internal.slidingRate(anchor, share, arm, normal, sliding, speed, motion, limit)) - (1
     - coupling)/relaxationTime*anchor + Internal.carriedRate(anchor, meanNormal, w, (smallest/radius)^4, relaxationTime);
  annotation (Inline=false, Documentation(info="<html>
<p>
Each point k has a static spring with the share w<sub>k</sub> of the pair's stiffness S in which it takes part in the largest friction force, w<sub>k</sub> = &mu;<sub>k</sub> F<sub>n,k</sub>/(&#931; &mu; F<sub>n</sub> + S 10 nm), and its own
coefficient of friction by <a href=\"modelica://ContactMultiBody.Friction.stribeck\">Stribeck's curve</a> at its own speed. So all springs slip at the same stretch L. The anchors of all points move as one rigid body, whose
translation and rotation against the bodies are the states of the pair. The force on a point is
</p>
<blockquote><pre>
F_k = -S w_k (c s_k + b T v_k),    s_k = tangential part of (z + psi x r_k/rho)
</pre></blockquote>
<p>
with translation z, turning &#968; as a length, lever r<sub>k</sub> about the centre of the friction and radius of gyration &#961; of the points; damper T v<sub>k</sub>, of which b leaves so much that no point goes beyond its limit; and c = 1 but where
the springs are stretched further than L in the mean square, as the normal force fell: c makes them L long. The sum of the friction forces of all points is never more than the sum of their &mu; F<sub>n</sub>.
</p>
<p>
The patch sticks, and is purely elastic, until the first point carries 0.9 of its limit. From there on sliding takes over, fully where the first point slips: the anchor is dragged to where the springs give the
sum of the sliding friction of the points, -&mu; F<sub>n</sub> v/|v| at each. The stretch turns with the bodies. What exceeds the limit, and what stands along the normal as the contact turned, is forgotten within the relaxation time; so is all of it
when the bodies part. At the start of a contact, where F<sub>n</sub> is nearly zero, 10 nm of way make the anchor grip gradually: without them it would be a switch.
</p>
<p>See the package <a href=\"modelica://ContactMultiBody.Friction\">Friction</a> for the derivation and why the law cannot give energy.</p>
</html>"));
end anchoredPatch;
