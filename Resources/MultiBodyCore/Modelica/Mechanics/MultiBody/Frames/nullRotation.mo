within Modelica.Mechanics.MultiBody.Frames;
function nullRotation "Orientation of a frame parallel to the first one and at rest"
  extends Modelica.Icons.Function;
  output Orientation R "Frame 2 parallel to frame 1";
algorithm
  R := Orientation(T=identity(3), w=zeros(3));
  annotation (Inline=true, Documentation(info="<html>
<p>No rotation.</p></html>"));
end nullRotation;
