within CoreFixtures;
model PointGravityOrbit "Point mass on an elliptic orbit"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(gravityType=MB.Types.GravityTypes.PointGravity, mu=4, enableAnimation=false);
  MB.Parts.PointMass planet(m=3, r_0(start={1,0,0}, each fixed=true), v_0(start={0,2.2,0.4}, each fixed=true), stateSelect=StateSelect.always, animation=false);
  Real energy = planet.v_0*planet.v_0/2 - world.mu/sqrt(planet.r_0*planet.r_0) "Energy of unit mass";
  Real area[3] = cross(planet.r_0, planet.v_0) "Twice the areal velocity";
  annotation (experiment(StopTime=3, Tolerance=1e-9));
end PointGravityOrbit;
