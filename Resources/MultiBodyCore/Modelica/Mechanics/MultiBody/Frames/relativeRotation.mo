within Modelica.Mechanics.MultiBody.Frames;
function relativeRotation "Orientation of frame 2 with respect to frame 1 from two absolute ones"
  extends Modelica.Icons.Function;
  input Orientation R1 "Absolute orientation of frame 1";
  input Orientation R2 "Absolute orientation of frame 2";
  output Orientation R_rel "Orientation of frame 2 with respect to frame 1";
algorithm
  R_rel := Orientation(T=R2.T*transpose(R1.T), w=R2.w - R2.T*(transpose(R1.T)*R1.w));
  annotation (Inline=true, Documentation(info="<html>
<p>Angular velocities subtract once resolved in the same frame.</p></html>"));
end relativeRotation;
