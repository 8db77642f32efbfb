within CoreFixtures;
model PlanarTilted "Planar joint in a tilted plane whose x-direction is not at right angles to the normal"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Planar joint(n={0.3,0.2,1}, n_x={1,1,0.5}, s_x(fixed=true), s_y(fixed=true), phi(fixed=true), v_x(fixed=true), v_y(fixed=true),
    w(fixed=true, start=1), animation=false);
  MB.Parts.Body body(m=1, r_CM={0,0,0}, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end PlanarTilted;
