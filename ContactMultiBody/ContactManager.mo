within ContactMultiBody;
model ContactManager "Lets all bodies it is connected to collide"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody.Frames;

  parameter Integer n(min=2) = 2 "Number of bodies" annotation (Evaluate=true, Dialog(connectorSizing=false));
  parameter String geometry[n] "Descriptor of each body's geometry, usually {body1.geometry, ...}";
  parameter Materials.Material material[n] "Material of each body, usually {body1.material, ...}";
  parameter Integer pairs[:, 2]=fill(0, 0, 2) "Pairs of bodies that may touch; empty: all pairs" annotation (Evaluate=true);
  final parameter Integer m=if size(pairs, 1) > 0 then size(pairs, 1) else div(n*(n - 1), 2) "Number of pairs"
    annotation (Evaluate=true);
  final parameter Integer pair[m, 2]=Internal.pairsLookedAt(pairs, n, m) "Bodies of each pair" annotation (Evaluate=true);
  parameter Integer pointCapacity(min=1) = 4 "Largest number of contact points of a pair" annotation (Evaluate=true);
  parameter Types.Backend backend=Types.Backend.Automatic "Algorithm that finds the contacts"
    annotation (Evaluate=true, Dialog(tab="Advanced"));

  parameter Types.NormalLaw normalLaw=Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Types.StiffnessChoice stiffnessChoice=Types.StiffnessChoice.Hertz "Where the stiffness comes from"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Real exponent(min=1, unit="1") = if stiffnessChoice == Types.StiffnessChoice.Hertz then 1.5 else 1
    "Exponent of the depth" annotation (Dialog(group="Normal force"));
  parameter SI.Radius contactRadius[m]=fill(0.01, m) "Radius of curvature of each pair's contact"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Hertz));
  parameter Real stiffness[m]=if stiffnessChoice == Types.StiffnessChoice.Hertz then Materials.pairHertzStiffness(
      material.E, material.nu, pair, contactRadius) else fill(1e6, m) "Stiffness of each pair in N/m^exponent"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Given));
  parameter SI.TranslationalDampingConstant damping[m]=fill(1e3, m) "Damping constant of each pair, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));
  parameter SI.Length dampingDepth=1e-4 "Depth from which dampers act fully, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));

  parameter Boolean useRestitution=normalLaw <> Types.NormalLaw.SpringDamper
    "= true, if impacts deliver the coefficients of restitution"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Restitution"));
  parameter Types.CombinationRule restitutionRule=Types.CombinationRule.Minimum "How restitution of two materials combines"
    annotation (Evaluate=true, Dialog(group="Restitution", enable=useRestitution));
  parameter Real restitution[m](each min=0, each max=1, each unit="1") = Materials.combine(material.restitution, pair,
    restitutionRule) "Coefficient of restitution of each pair" annotation (Dialog(group="Restitution", enable=useRestitution));
  parameter SI.Velocity restSpeed(min=Modelica.Constants.small) = 0.01 "Impacts slower than this come to rest"
    annotation (Dialog(group="Restitution", enable=useRestitution));
  parameter Real steadyRate[m](each min=0, each unit="s/m") = fill(0.5, m)
    "Damping of each pair by the force law F = K x^n (1 + steadyRate dx/dt), where restitution is not used"
    annotation (Dialog(group="Restitution", enable=not useRestitution));

  parameter Types.Friction friction=Types.Friction.Regularised "Law of friction"
    annotation (Evaluate=true, Dialog(group="Friction"));
  parameter Types.CombinationRule frictionRule=Types.CombinationRule.GeometricMean "How friction of two materials combines"
    annotation (Evaluate=true, Dialog(group="Friction", enable=friction <> Types.Friction.None));
  parameter Real muStatic[m](each min=0, each unit="1") = Materials.combine(material.muStatic, pair, frictionRule)
    "Coefficient of static friction of each pair" annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter Real muDynamic[m](each min=0, each unit="1") = Materials.combine(material.muDynamic, pair, frictionRule)
    "Coefficient of sliding friction of each pair" annotation (Dialog(group="Friction", enable=friction <> Types.Friction.None));
  parameter SI.Velocity regularisationSpeed(min=Modelica.Constants.small) = 1e-3
    "Sliding speed over which regularised friction changes its direction"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Regularised));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame[n] "Frames of the bodies"
    annotation (Placement(transformation(extent={{-116,-80},{-84,80}})));

  SI.Distance distance[m] "Signed distance of each pair, negative when penetrating";
  SI.Force normalForce[m] "Normal force of each pair, summed over its points";
  SI.Force force[m, 3] "Force on the first body of each pair, in world axes";
  SI.Velocity approachSpeed[m] "Speed at which the bodies of each pair approach where they touch";
  SI.Velocity impactSpeed[if useRestitution then m else 0] "Approach speed of each pair when its last contact started";
  Boolean touches[if useRestitution then m else 0] "= true, if the bodies of the pair touch";
  SI.Energy elasticEnergy "Energy stored in the compliance of all contacts";

  final parameter Integer scene=Internal.intern(geometry, pair, Integer(backend) - 1) "Handle of the scene in the engine";
  final parameter Real dampingFactor[m](each unit="1") = Internal.dampingFactors(normalLaw, restitution)
    "Damping factor of each pair";

protected
  SI.Position r_0[n, 3] "Origins of the bodies' frames";
  SI.Velocity v_0[n, 3] "Velocities of the origins";
  SI.AngularVelocity w_0[n, 3] "Angular velocities, in world axes";
  SI.Length depth[m, pointCapacity] "Penetration depth of each point";
  Real weight[m, pointCapacity](each unit="1") "Share of the law's force each point carries";
  Real normal[m, pointCapacity, 3](each unit="1") "Normal of each point";
  SI.Position point[m, pointCapacity, 3] "Contact points";
  SI.Velocity pointVelocity[m, pointCapacity, 3] "Velocity of first against second body at each point";
  SI.Velocity pointSpeed[m, pointCapacity] "Approach speed at each point";
  SI.Force pointNormalForce[m, pointCapacity] "Normal force of each point";
  SI.Force pointForce[m, pointCapacity, 3] "Force of each point on the first body";
  SI.Force bodyForce[n, 3] "Contact force on each body, in world axes";
  SI.Torque bodyTorque[n, 3] "Contact torque on each body about its frame, in world axes";
  Real rate[if useRestitution then m else 0](each unit="s/m") "Damping factor by impact speed of each pair";
  Internal.ImpactSpeeds impact(m=m) if useRestitution;
equation
  for i in 1:n loop
    r_0[i, :] = frame[i].r_0;
    w_0[i, :] = Frames.resolve1(frame[i].R, frame[i].R.w);
  end for;
  v_0 = der(r_0);

  (distance,depth,weight,normal,point) = Internal.query(scene, r_0, {frame[i].R.T for i in 1:n}, m, pointCapacity);

  pointVelocity = Internal.pointVelocities(point, r_0, v_0, w_0, pair);
  pointSpeed = Internal.approachSpeeds(pointVelocity, normal);
  approachSpeed = Internal.pairApproachSpeeds(pointSpeed, weight);

  if useRestitution then
    for i in 1:m loop
      touches[i] = distance[i] < 0;
    end for;
    impact.touches = touches;
    impact.approachSpeed = approachSpeed;
    impactSpeed = impact.impactSpeed;
    for i in 1:m loop
      rate[i] = NormalForce.dampingRate(dampingFactor[i], impactSpeed[i], restSpeed);
    end for;
  end if;

  if normalLaw == Types.NormalLaw.SpringDamper then
    pointNormalForce = Internal.springDamperForces(depth, weight, pointSpeed, stiffness, exponent, damping, dampingDepth);
  elseif useRestitution then
    pointNormalForce = Internal.normalForces(depth, weight, pointSpeed, stiffness, exponent, rate);
  else
    pointNormalForce = Internal.normalForces(depth, weight, pointSpeed, stiffness, exponent, steadyRate);
  end if;

  if friction == Types.Friction.None then
    pointForce = Internal.frictionlessForces(pointNormalForce, normal);
  else
    pointForce = Internal.regularisedForces(pointNormalForce, normal, pointVelocity, pointSpeed, muDynamic, regularisationSpeed);
  end if;

  for i in 1:m loop
    normalForce[i] = sum(pointNormalForce[i, :]);
  end for;
  for i in 1:m loop
    force[i, :] = {sum(pointForce[i, :, 1]),sum(pointForce[i, :, 2]),sum(pointForce[i, :, 3])};
  end for;
  elasticEnergy = Internal.elasticEnergy(depth, weight, stiffness, exponent);

  bodyForce = Internal.bodyForces(pointForce, pair, n);
  bodyTorque = Internal.bodyTorques(pointForce, point, r_0, pair);
  for i in 1:n loop
    frame[i].f = -Frames.resolve2(frame[i].R, bodyForce[i, :]);
    frame[i].t = -Frames.resolve2(frame[i].R, bodyTorque[i, :]);
  end for;
  annotation (
    defaultComponentName="contacts",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40,80},{40,0}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,4},{80,-40}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{0,4},{0,70}}, color={255,0,0}, thickness=0.5, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255}),
        Text(extent={{-100,-60},{100,-90}}, textString="n=%n")}),
    Documentation(info="<html>
<p>
Connect a frame of each body that may collide to an element of <code>frame</code>, and give the bodies' geometries and
materials in the same order:
</p>
<blockquote><pre>
ContactMultiBody.Parts.Body ball(geometry=ContactMultiBody.Shapes.sphere(0.1), ...);
ContactMultiBody.Parts.Ground floor;
ContactMultiBody.ContactManager contacts(
  n=2,
  geometry={ball.geometry, floor.geometry},
  material={ball.material, floor.material});
equation
connect(ball.frame_a, contacts.frame[1]);
connect(floor.frame_a, contacts.frame[2]);
</pre></blockquote>
<p>
The geometry of a body is described in the frame that is connected. By default all pairs of bodies may touch;
<code>pairs={{1,3},{2,3}}</code> names those that are to be looked at, which saves time.
</p>
<p>
The force of a contact point is F = weight K x<sup>n</sup>(1 + d/v<sub>0</sub> dx/dt), never negative, with the approach speed at that
point; the weights of a face that carries wholly sum to one. See
<a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> and <a href=\"modelica://ContactMultiBody.Friction\">Friction</a> for the laws.
</p>
<p>
All choices are structural: without friction there are no tangential forces, without restitution no events.
<code>touches</code> and <code>impactSpeed</code> exist where impacts are caught by events.
</p>
</html>"));
end ContactManager;
