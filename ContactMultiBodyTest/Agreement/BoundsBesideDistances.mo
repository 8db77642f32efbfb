within ContactMultiBodyTest.Agreement;
partial model BoundsBesideDistances "Moved bodies, and how far answers with bounds differ from those with exact distances"
  parameter String shape[3]={ContactMultiBody.Shapes.box({0.2,0.3,0.25}),ContactMultiBody.Shapes.cylinder(0.1, 0.2),
    ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(0.1, {0.1,0,0}),ContactMultiBody.Shapes.box({0.3,0.1,0.1})})}
    "Geometries of the moved bodies";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  MovedBody body[3](phase={0.1,1.3,2.2}, each size=0.5, each center={0,0,0.5});
  ContactMultiBody.Parts.Ground floor;
  WrenchComparison comparison(n=4);
  Modelica.Units.SI.Velocity impactDifference "Largest difference of the speeds that events caught";
  Modelica.Units.SI.Length excess "Largest excess of a bound over the distance";
  Modelica.Units.SI.Length shortfall "Largest shortfall of a bound";
  annotation (Documentation(info="<html>
<p>The model that extends it lets the bodies collide by two managers, and compares their variables.</p>
</html>"));
end BoundsBesideDistances;
