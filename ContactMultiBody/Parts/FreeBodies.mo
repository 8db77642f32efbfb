within ContactMultiBody.Parts;
model FreeBodies "Many equal free rigid bodies that collide with each other and with fixed surroundings"
  extends Interfaces.PartialCompiledContacts(
    final n=bodyCount + 1,
    final geometry={if i <= bodyCount then bodyGeometry else surroundings for i in 1:bodyCount + 1},
    final inertia(
      m={if i <= bodyCount then bodyMass else 0 for i in 1:bodyCount + 1},
      each I=diagonal(bodyInertia)),
    final contactRadius={if i <= bodyCount then bodyRadius else Modelica.Constants.inf for i in 1:bodyCount + 1},
    final stiffness={if i <= bodyCount then bodyStiffness else Modelica.Constants.inf for i in 1:bodyCount + 1},
    final group=fill(1, bodyCount + 1),
    final collidesWith=fill(-1, bodyCount + 1),
    final excluded=fill(0, 0, 2));
  parameter Integer bodyCount(min=1)=2 "Number of free bodies" annotation (Evaluate=true);
  parameter String bodyGeometry=Shapes.sphere(0.1)
    "Descriptor of each free body's geometry in its frame, which lies in the centre of mass along the principal axes";
  parameter Modelica.Units.SI.Mass bodyMass(min=Modelica.Constants.small)=1 "Mass of each free body";
  parameter Modelica.Units.SI.Inertia bodyInertia[3](each min=Modelica.Constants.small)=fill(0.004, 3)
    "Principal moments of inertia of each free body";
  parameter Modelica.Units.SI.Radius bodyRadius=0.1 "Radius of curvature of the free bodies' surfaces"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Hertz));
  parameter Real bodyStiffness=1e6 "Stiffness of each free body against a rigid one in N/m^exponent"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Given));
  parameter String surroundings=Shapes.halfSpace() "Descriptor of the fixed surroundings, in world axes";
  parameter Modelica.Units.SI.Acceleration gravity[3]={0,0,-9.81} "Acceleration of gravity, in world axes";
  parameter Modelica.Units.SI.Position r_start[bodyCount, 3]={{0,0,0.3*i} for i in 1:bodyCount}
    "Positions of the centres of mass at the start" annotation (Dialog(tab="Initialization"));
  parameter Modelica.Units.SI.Velocity v_start[bodyCount, 3]=zeros(bodyCount, 3)
    "Velocities of the centres of mass at the start" annotation (Dialog(tab="Initialization"));
  parameter Modelica.Units.SI.AngularVelocity w_start[bodyCount, 3]=zeros(bodyCount, 3)
    "Angular velocities at the start, in the bodies' axes" annotation (Dialog(tab="Initialization"));

  Modelica.Units.SI.Position r[bodyCount, 3](start=r_start, each fixed=true, each stateSelect=StateSelect.always)
    "Positions of the centres of mass, in world axes";
  Modelica.Units.SI.Velocity v[bodyCount, 3](start=v_start, each fixed=true, each stateSelect=StateSelect.always)
    "Velocities of the centres of mass, in world axes";
  Real Q[bodyCount, 4](start={{0,0,0,1} for i in 1:bodyCount}, each fixed=true, each stateSelect=StateSelect.always,
    each unit="1") "Quaternions, from world to the bodies' frames";
  Modelica.Units.SI.AngularVelocity w[bodyCount, 3](start=w_start, each fixed=true, each stateSelect=StateSelect.always)
    "Angular velocities, in the bodies' axes";
  Modelica.Units.SI.Force surroundingsForce[3]=Internal.FreeBodies.forceOnSurroundings(responseForce)
    "Contact force on the surroundings";
  Modelica.Units.SI.Energy kineticEnergy "Kinetic energy of all bodies";
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy of all bodies";
protected
  Real rotation[bodyCount, 3, 3](each unit="1") "Rotations from world to the bodies' frames";
  Modelica.Units.SI.AngularVelocity wWorld[bodyCount, 3] "Angular velocities, in world axes";
  Modelica.Units.SI.Energy bodyKineticEnergy[bodyCount] "Kinetic energy of each body";
  Modelica.Units.SI.Energy bodyPotentialEnergy[bodyCount] "Potential energy of each body";
equation
  rotation = Internal.FreeBodies.quaternionRotations(Q);
  wWorld = Internal.FreeBodies.worldVectors(rotation, w);
  r_0 = Internal.FreeBodies.withSurroundings(r);
  v_0 = Internal.FreeBodies.withSurroundings(v);
  T = Internal.FreeBodies.withSurroundingsFrame(rotation);
  w_0 = Internal.FreeBodies.withSurroundings(wWorld);

  der(r) = v;
  der(v) = Internal.FreeBodies.accelerations(bodyMass, gravity, responseForce, bodyCount);
  der(Q) = Internal.FreeBodies.quaternionRates(Q, w);
  der(w) = Internal.FreeBodies.angularAccelerations(bodyInertia, w, rotation, responseTorque);

  bodyKineticEnergy = Internal.FreeBodies.kineticEnergies(bodyMass, bodyInertia, v, w);
  kineticEnergy = Internal.FreeBodies.total(bodyKineticEnergy);
  bodyPotentialEnergy = -bodyMass*(r*gravity);
  energy = kineticEnergy + Internal.FreeBodies.total(bodyPotentialEnergy) + elasticEnergy;
  annotation (
    defaultComponentName="bodies",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,-40},{100,-80}}, lineColor={95,95,95}, fillColor={175,175,175}, fillPattern=FillPattern.Backward),
        Ellipse(extent={{-90,20},{-30,-40}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{-30,20},{30,-40}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{30,20},{90,-40}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{-60,72},{0,12}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{0,72},{60,12}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,120},{150,80}}, textString="%name", textColor={0,0,255}),
        Text(extent={{-150,-85},{150,-115}}, textString="%bodyCount")}),
    Documentation(info="<html>
<p>
A hundred, or a thousand, equal bodies as arrays of positions, quaternions and velocities in one model: 13 states a body and
no connectors. The contact forces between them, and with one fixed body, <code>surroundings</code>, are those of the
<a href=\"modelica://ContactMultiBody.CompiledContactManager\">CompiledContactManager</a>. The surroundings may be a compound, as a box of five
half-spaces: see <a href=\"modelica://ContactMultiBody.Examples.SpheresInBox\">SpheresInBox</a>. The compliance is that of the free bodies; the
surroundings are rigid.
</p>
<p>
<code>energy</code> is the sum of kinetic, potential and elastic energy; it never rises, but where an integrator errs.
<code>surroundingsForce</code> is what the surroundings carry. Bodies connected to a mechanism need frames: use a
<a href=\"modelica://ContactMultiBody.Parts.Body\">Body</a> for each, and the CompiledContactManager.
</p>
</html>"));
end FreeBodies;
