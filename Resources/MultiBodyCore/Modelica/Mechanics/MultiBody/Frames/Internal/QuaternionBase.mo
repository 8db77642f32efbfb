within Modelica.Mechanics.MultiBody.Frames.Internal;
type QuaternionBase = Real[4](each unit="1") "Four numbers"
  annotation (Documentation(info="<html><p>Array type of the quaternions.</p></html>"));
