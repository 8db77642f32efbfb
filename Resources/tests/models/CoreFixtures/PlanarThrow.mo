within CoreFixtures;
model PlanarThrow "Body thrown in a plane"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,-1,0}, g=9.81, enableAnimation=false);
  MB.Joints.Planar joint(n={0,0,1}, n_x={1,0,0}, s_x(fixed=true, start=0.1), s_y(fixed=true, start=0.2), phi(fixed=true, start=0.3),
    v_x(fixed=true, start=2), v_y(fixed=true, start=3), w(fixed=true, start=4), animation=false);
  MB.Parts.Body body(m=1, r_CM={0,0,0}, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end PlanarThrow;
