within ContactMultiBody.Examples;
model SpheresOnFloor "A hundred spheres are thrown on a floor and come to rest"
  extends Modelica.Icons.Example;
  final parameter Integer n=100 "Number of spheres";
  Parts.FreeBodies spheres(
    bodyCount=n,
    bodyGeometry=Shapes.sphere(0.05),
    bodyMass=0.5,
    bodyInertia=fill(0.4*0.5*0.05^2, 3),
    surroundings=Shapes.halfSpace(),
    material(each restitution=0.3, each muStatic=0.5),
    stiffnessChoice=Types.StiffnessChoice.Given,
    bodyStiffness=2e4,
    regularisationSpeed=0.02,
    spinRadius=0.005,
    rollingLever=0.01,
    turningRegularisationSpeed=0.2,
    r_start={{0.12*mod(i - 1, 10),0.12*div(i - 1, 10),0.06 + 0.03*mod(7*i, 11)} for i in 1:n},
    v_start={{sin(1.7*i),cos(2.3*i),0} for i in 1:n}) annotation (Placement(transformation(extent={{-20,-20},{20,20}})));
  annotation (
    experiment(StopTime=4, Tolerance=1e-6, Interval=0.01),
    __OpenModelica_simulationFlags(s="gbode", gbm="dopri45"),
    Documentation(info="<html>
<p>
A hundred spheres of 0.5 kg fall from up to 0.36 m with horizontal speeds of about 1 m/s in all directions, bounce with e = 0.3, run into each
other and are stopped by friction against sliding, rolling and spinning. The energy, <code>spheres.energy</code>, never rises; in the end the floor
carries the weight of all: <code>spheres.surroundingsForce[3]</code> = -490.5 N, and <code>spheres.kineticEnergy</code> is zero.
</p>
</html>"));
end SpheresOnFloor;
