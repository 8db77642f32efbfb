within CoreFixtures;
model ExternalGravity "Gravity from a function of the model's own"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  function attraction "Gravity that grows with the distance from the z-axis"
    extends MB.Interfaces.partialGravityAcceleration;
  algorithm
    gravity := {-r[1],-r[2],0};
  end attraction;
  inner MB.World world(redeclare function gravityAcceleration = attraction, enableAnimation=false);
  MB.Parts.PointMass mass(m=1, r_0(start={1,0,0}, each fixed=true), v_0(start={0,1,0.5}, each fixed=true), stateSelect=StateSelect.always, animation=false);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end ExternalGravity;
