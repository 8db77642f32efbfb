within ContactMultiBody.Examples;
model SpheresInBox "Smooth spheres fall into an open box and fill it"
  extends Modelica.Icons.Example;
  parameter Integer edge=3 "Spheres along each edge of the lattice they start in" annotation (Evaluate=true);
  parameter Modelica.Units.SI.Length pitch=0.12 "Distance of the spheres in that lattice" annotation (Evaluate=true);
  final parameter Integer n=edge*edge*edge "Number of spheres";
  final parameter Modelica.Units.SI.Length a=pitch*edge "Width of the box";
  Parts.FreeBodies spheres(
    bodyCount=n,
    bodyGeometry=Shapes.sphere(0.05),
    bodyMass=0.5,
    bodyInertia=fill(0.4*0.5*0.05^2, 3),
    surroundings=Shapes.compound({Shapes.halfSpace(),Shapes.halfSpace(normal={1,0,0}, position={0,0,0}),
      Shapes.halfSpace(normal={-1,0,0}, position={a,0,0}),Shapes.halfSpace(normal={0,1,0}, position={0,0,0}),
      Shapes.halfSpace(normal={0,-1,0}, position={0,a,0})}),
    material(each restitution=0.3, each muStatic=0.5),
    stiffnessChoice=Types.StiffnessChoice.Given,
    bodyStiffness=2e4,
    useFriction=false,
    r_start={{pitch*(mod(i - 1, edge) + 0.5) + 0.2*(pitch - 0.1)*sin(1.7*i),pitch*(mod(div(i - 1, edge), edge) + 0.5) + 0.2*(pitch
       - 0.1)*cos(2.3*i),pitch*(div(i - 1, edge*edge) + 0.7)} for i in 1:n}) annotation (Placement(transformation(extent={{-20,-20},{20,20}})));
  Modelica.Units.SI.Position lowest=min(spheres.r[:, 3]) "Height of the lowest centre";
  Modelica.Units.SI.Distance farthest=max(abs(spheres.r[:, 1:2] - fill(a/2, n, 2)))
    "How far a centre is from the middle of the box, along one of its sides";
  annotation (
    experiment(StopTime=5, Tolerance=1e-6, Interval=0.01),
    __OpenModelica_simulationFlags(s="gbode", gbm="dopri45"),
    Documentation(info="<html>
<p>
<code>edge</code><sup>3</sup> smooth spheres of 0.5 kg and 0.1 m diameter start on a lattice, shaken a little, in a box without a lid. They fall, run
into each other and find a place in which all rest. The energy never rises, none escapes, and the floor carries the weight of all: <code>spheres.surroundingsForce[3]</code> = -n m g.
With friction the end would take longer: regularised friction lets a heap creep until it gives way, again and again.
</p>
<p>
<code>edge=10</code> makes a thousand spheres, 13000 states; with <code>pitch=0.103</code> and tolerance 1e-3 they have lost all but a hundredth of their kinetic energy after 1.2 s, and the floor carries their weight of 4905 N within 0.5 %.
</p>
</html>"));
end SpheresInBox;
