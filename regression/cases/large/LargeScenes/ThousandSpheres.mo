within LargeScenes;
model ThousandSpheres "10 x 10 x 10 smooth spheres fall into a box, where they find places and rest"
  extends ContactMultiBody.Examples.SpheresInBox(edge=10, pitch=0.103);
  annotation (experiment(StopTime=3, Tolerance=1e-3, Interval=0.01), Documentation(info="<html>
<p>
The lattice is 3 % wider than the spheres, so that they fall little and are held by each other soon.
</p>
</html>"));
end ThousandSpheres;
