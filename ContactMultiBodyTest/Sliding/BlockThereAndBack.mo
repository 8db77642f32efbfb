within ContactMultiBodyTest.Sliding;
model BlockThereAndBack "A block that is pushed from rest to rest: along x, along y, and back along x"
  extends Modelica.Icons.Example;
  extends PushedBody(grip(r={0,0,0}));
  final parameter Modelica.Units.SI.Force hold=mu*m*world.g "Largest friction force";
equation
  push.force = hold*(if time < 0.1 then {0,0,0} elseif time < 0.3 then {1.5,0,0} elseif time < 0.5 then {0,0,0} elseif time < 0.7 then {0,1.5,0}
     elseif time < 0.9 then {0,0,0} elseif time < 1.1 then {-1.5,0,0} elseif time < 1.3 then {0,0,0} else {0.5,-0.5,0});
  annotation (experiment(StopTime=1.5, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
Each push of 1.5 &mu; m g lasts 0.2 s: the block gains &mu; g/2 0.2 s of speed over &mu; g/4 (0.2 s)<sup>2</sup>, and slides to rest in another 0.1 s. A force of
0.71 &mu; m g at the end does not move it.
</p>
</html>"));
end BlockThereAndBack;
