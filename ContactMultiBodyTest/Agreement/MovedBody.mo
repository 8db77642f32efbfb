within ContactMultiBodyTest.Agreement;
model MovedBody "Frame that moves and turns on a path of many frequencies"
  import Modelica.Mechanics.MultiBody.Frames;
  parameter Real phase=0 "Tells paths apart";
  parameter Modelica.Units.SI.Position center[3]={0,0,0.3} "Middle of the path";
  parameter Modelica.Units.SI.Length size=0.25 "How far the path goes";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Moved frame";
  Modelica.Units.SI.Angle angle[3] "Angles about the axes";
  Modelica.Units.SI.AngularVelocity speed[3] "Their derivatives";
equation
  Connections.root(frame_a.R);
  frame_a.r_0 = center + size*{sin(1.31*time + 2*phase),sin(1.73*time + 3*phase + 1),sin(2.11*time + 5*phase + 2)};
  angle = {2*sin(0.71*time + phase),0.9*time + phase,2*sin(1.13*time + 7*phase)};
  speed = der(angle);
  frame_a.R = Frames.axesRotations({1,2,3}, angle, speed);
  annotation (Documentation(info="<html>
<p>Frequencies without a common period: other times are other scenes.</p>
</html>"));
end MovedBody;
